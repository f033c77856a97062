(expect NGC0129 2:9)
G0 X[1+2
M2
