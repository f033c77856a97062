(expect CEN0416 4:4)
G98 F10 X1 Z0
X3 Z-1.5 (estimated start point)
G3 XC1 ZC-3 X3 Z-5 (estimated end point)
G1 X3 Z-6
