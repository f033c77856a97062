G21
o<corner> call [5] [2]
G0 X0
M2
