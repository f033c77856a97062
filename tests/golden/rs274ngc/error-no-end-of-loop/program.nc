(expect NGC0293 5:0)
o1 while [0]
G0 X1
M2
