(expect NGC0131 2:6)
G0 X[FOO[1]]
M2
