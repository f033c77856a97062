(msg, first)(plain)
( M s G ,  hello World )G0 X1
(note)(MSG,second)
M2
