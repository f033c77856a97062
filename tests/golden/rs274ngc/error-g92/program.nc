(expect NGC0164 2:0)
G92
M2
