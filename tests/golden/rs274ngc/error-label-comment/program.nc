(expect NGC0298 3:13)
G21
o1 (a sub?) sub
M2
