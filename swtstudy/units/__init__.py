"""Real contacts: from lengths, moduli and forces to the parameters of a study, and back."""
