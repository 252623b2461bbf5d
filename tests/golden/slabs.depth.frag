#version 450
// wet_metal · slab_surface · mxgen 0.1 · vulkan · reduced · 0 closures · 0 textures

void main()
{
}
