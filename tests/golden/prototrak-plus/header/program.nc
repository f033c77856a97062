PLATE 12 G20 PN4711 ;
N001 G100 X1.5 Y2.25 ;
% anything behind it ;
