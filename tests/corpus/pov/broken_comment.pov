#version 3.7;
/* never
