(expect NGC0226 2:0)
G43
M2
