(expect PTK0109 3:0)
G20 ;
G100 X1E3 Y1. ;
%
