"""When the stress at a place has cusps in time.

At a fixed x that happens when the contact edge passes (normal load = G of the spring at x) and when the slip
front does (the spring at x goes from stick to slip). Together with the turning instants of the load they cut
the cycle into stretches in which the stress is smooth but for square roots at the ends; cosine-spaced nodes
resolve those.
"""
