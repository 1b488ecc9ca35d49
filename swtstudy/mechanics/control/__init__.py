"""What is prescribed: the coordinate in which the memory diagram is drawn, one name of the contact radius."""
