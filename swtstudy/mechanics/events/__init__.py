"""When the stress at a place has cusps in time, and closer looks between them."""
