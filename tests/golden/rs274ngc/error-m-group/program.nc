(expect NGC0157 2:4)
M7 M8
M2
