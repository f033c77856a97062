(expect NGC0300 3:0)
o1 while [1]
o1 endwhile
M2
