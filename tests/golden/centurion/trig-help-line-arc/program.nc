O0101
G21 G98 F100
G0 X12 Z10
G1 Z-15 (estimate inside the circle: shortened)
G3 XC0 ZC-20 R10 X16 Z-31
G1 Z-40
G0 X12 Z10
G1 Z-3 (estimate short of it: extended)
G3 XC0 ZC-20 X18 Z-22 (no R: the last one)
G1 X16 Z-40
X16.002 Z-26.001 (back to a point that is on the arc: kept)
G2 XC0 ZC-20 R10 X12 Z-12
G1 X30 Z-9 (the arc's end was exact)
M30
