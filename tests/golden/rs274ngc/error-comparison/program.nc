(expect NGC0130 2:8)
G0 X[2 GT 1]
M2
