(expect PTK0103 3:0)
PN1 G20 ;
G100 X1.# ;
%
