(expect NGC0103 2:7)
G0 X1 (a
M2
