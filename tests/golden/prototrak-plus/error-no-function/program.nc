(expect PTK0107 4:0)
PN1 G20 ;
G100 X1. Y1. ;
X2. Y2. ;
%
