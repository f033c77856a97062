G21
o1 sub
G0 X#1 Y#2 Z#3
o1 endsub
o1 call [1] (comment) [2] (another) [3] (last)
o1 call (first) [4]
M19
(DEBUG,%.2f#9)
#9=-0
#8=[-1*0.0000001]
(DEBUG,#9 #8 %d#8 %.2f#8)
M2
