(expect PS004 3:1)
O0701
5. X1.
M30
