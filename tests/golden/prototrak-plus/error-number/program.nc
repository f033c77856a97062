(expect PTK0105 4:0)
PN1 G20 ;
G100 X1. Y1. ;
G100 X Y2. ;
%
