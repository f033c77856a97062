(expect CEN0403 3:0)
G0 Z.5
Z.75
