(expect NGC0105 2:5)
G0 X-.
M2
