(expect NGC0102 2:10)
G0 X1 (a (b))
M2
