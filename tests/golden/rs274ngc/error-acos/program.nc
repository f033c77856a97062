(expect NGC0122 2:6)
G0 X[ACOS[1.5]]
M2
