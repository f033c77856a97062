(expect PS-rotation-home 4:1)
O0533
G51 P2000
G28 X0
M30
