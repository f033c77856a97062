(expect NGC0200 2:0)
G1 X2
M2
