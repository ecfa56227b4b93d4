// The bar of the .msh files beside this one: gmsh -3 -format msh22 (or msh41) [-bin] [-order 2] bar.geo
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.5, 0.5};
MeshSize{:} = 0.5;
Physical Surface("clamped") = {1};
Physical Surface("loaded end") = {2};
Physical Surface(77) = {3};
Physical Volume("bar") = {1};
