
layout(local_size_x = MX_TILE, local_size_y = MX_TILE) in;

void main()
{
    mx_run(gl_WorkGroupID.xy, gl_LocalInvocationID.xy);
}
