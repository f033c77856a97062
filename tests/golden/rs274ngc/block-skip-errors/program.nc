(expect NGC0130 2:9)
/G0 X[1 @ 2]
M2
