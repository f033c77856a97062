/G0 X1
 G0 X[6/4]
 / N7 Y3
M2
