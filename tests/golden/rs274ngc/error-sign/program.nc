(expect NGC0105 3:5)
#1=2
G0 X-#1
M2
