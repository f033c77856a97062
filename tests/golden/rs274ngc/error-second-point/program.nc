(expect NGC0106 2:5)
G0 X1.2.3
M2
