// Nothing of its own: what the precompiled headers of a build are made with (top CMakeLists.txt).
