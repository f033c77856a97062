(expect NGC0304 6:1)
M98 P1
M2
O1
G0 X1
O1 endsub
