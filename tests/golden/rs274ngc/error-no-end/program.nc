(expect NGC0116 3:0)
G0 X1
