(expect PTK0104 3:0)
PN1 G20 ;
G100 X100. Y1. ;
%
