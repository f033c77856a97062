(expect NGC0304 4:1)
M98 P1
M2
O1 sub
G0 X1
O1 endsub
