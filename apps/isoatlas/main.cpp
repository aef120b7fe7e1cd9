#include <isoatlas/isoatlas.h>

int main() { return 0; }
