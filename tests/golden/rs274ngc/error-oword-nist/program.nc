(expect NGC0100 2:1)
o1 sub
M2
