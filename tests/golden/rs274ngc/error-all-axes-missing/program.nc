(expect NGC0163 2:0)
G1
M2
