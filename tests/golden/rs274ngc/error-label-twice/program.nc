(expect NGC0294 5:1)
o1 if [0]
o1 endif
G0 X1
o1 while [0]
o1 endwhile
M2
