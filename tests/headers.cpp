// Holds the precompiled headers that the tests reuse.
int main() {}
