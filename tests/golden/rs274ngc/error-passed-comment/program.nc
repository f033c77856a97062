(expect NGC0103 4:4)
G20
o1 call
X1 (open
M2
o1 sub
G0 X2
o1 endsub
