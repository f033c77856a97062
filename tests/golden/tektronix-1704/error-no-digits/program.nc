(expect TEK0105 2:2) %
XY1
