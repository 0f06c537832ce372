// SPDX-License-Identifier: MIT
// Under the address sanitizer: leaks of the graphics driver and the validation layer are theirs. They are
// told apart by the library they come from, so libraries must still be loaded when leaks are looked for.
#if defined(__SANITIZE_ADDRESS__)

extern "C" {

// Keeps every library loaded to the end of the program, by standing in for the C library's function.
int dlclose(void* /*library*/);
const char* __lsan_default_suppressions();

int dlclose(void* /*library*/)
{
    return 0;
}

const char* __lsan_default_suppressions()
{
    return "leak:libvulkan_lvp\nleak:libVkLayer_khronos_validation\nleak:libLLVM\nleak:libvulkan.so\n";
}

} // extern "C"

#endif
