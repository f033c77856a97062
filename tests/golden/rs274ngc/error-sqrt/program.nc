(expect NGC0127 2:6)
G0 X[SQRT[-1]]
M2
