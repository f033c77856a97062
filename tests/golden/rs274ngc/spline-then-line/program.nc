G21 F100 G0 X0 Y0
G1 X1
G5.1 X2 Y0 I.5 J.5
X3
(DEBUG,%d#<_motion_mode>)
M2
