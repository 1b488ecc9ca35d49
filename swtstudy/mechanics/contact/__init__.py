"""The contact solution: the memory diagram of the MDR springs in one coordinate of the contact radius.

A spring at the coordinate G (the depth g(ξ)/δ0 or, for prescribed forces, the normal force: w and τ are then
no forces of springs, but o′ is the same) carries the compression w = N − G and the tangential force
τ = T − o, |τ| ≤ w, under the normal load N and the tangential load T. Its offset o(G, t) is the only memory:
while in contact it is clipped to [ℓ + G, r − G] with ℓ = T − N and r = T + N, and it starts with o = T at
touch-down. Hence o(G) is made of few pieces: lines of slope ±1 left by slip (o = ℓ + G, o = r − G), the curve
o = T(touch-down of G) left by growth in stick, a line where the load is straight, and o = 0 where nothing
ever slipped. They form a stack: slip pops pieces from the edge and pushes one, the loss of contact pops. No
indenter is known here.
"""
