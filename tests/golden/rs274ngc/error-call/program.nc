(expect NGC0301 2:1)
o9 call
M2
