#1=5
#<foo>=1
#2=EXISTS[#1]
#3=EXISTS[##1]
#4=EXISTS[#9999]
#5=EXISTS[#-3]
#6=EXISTS[#[1+1]]
#7=EXISTS[#<bar>]
(DEBUG,#2 #3 #4 #5 #6 #7)
#8=EXISTS[#<_value>]
(DEBUG,#8 #<_value> #<_value_returned>)
M2
