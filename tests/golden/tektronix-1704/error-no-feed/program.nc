(expect TEK0301 2:0) %
X1000
