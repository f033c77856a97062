(expect NGC0120 2:9)
G0 X[1/0]
M2
