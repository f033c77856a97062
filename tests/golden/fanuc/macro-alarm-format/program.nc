(expect PS114 3:5)
O0615
#1 2
M30
