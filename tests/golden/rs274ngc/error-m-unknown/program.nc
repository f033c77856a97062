(expect NGC0156 2:1)
M77
M2
