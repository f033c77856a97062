
  %  
N20 G1 F120 X10
N5 Y-5N5 M3 S400
 % 
this is no program text
