N123456.5 G0 X1 ; rest (of it
G1 F50
X2 ;(MSG,no)
G0
M2
