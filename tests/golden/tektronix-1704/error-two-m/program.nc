(expect TEK0108 2:4) %
M03M08
