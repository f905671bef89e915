#macro A(N) A(N + 1) #end
A(1)
