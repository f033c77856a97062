(expect NGC0128 2:6)
G0 X[LN[0]]
M2
