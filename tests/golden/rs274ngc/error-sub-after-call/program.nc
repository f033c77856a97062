(expect NGC0295 4:1)
G20
o1 call
o1 sub
G0 X1
o1 endsub
M2
