(expect NGC0304 4:1)
o1 call
M2
o1
G0 X1
M99
