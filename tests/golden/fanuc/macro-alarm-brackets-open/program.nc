(expect PS118 3:8)
O0614
#1=[1+2
M30
