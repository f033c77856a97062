(expect CEN0529 2:7)
X1 Z1 X2
