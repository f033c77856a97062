(expect PS-rotation-offset 4:1)
O0536
G68 X0 Y0 R10.
G55
M30
