(expect PTK0108 3:0)
PN1 G20 ;
N1 G105 XO1. ;
%
