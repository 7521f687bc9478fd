#include "pen_mount.h"

static struct v2 px(int x, int y)
{
	return (struct v2){(float)x / 100.0f, (float)y / 100.0f};
}

bool pen_mount_calibrate(const struct pen_mount *mount, struct plane_map *map, float *rms_px,
			 float *worst_px, char fault[200])
{
	struct v2 seen[PLANE_MAP_POINTS_MAX], meant[PLANE_MAP_POINTS_MAX];
	*map = plane_map_identity;
	*rms_px = *worst_px = 0.0f;
	if (mount->cross_count == 0)
		return true;
	MUST(mount->cross_count > 0 && mount->cross_count <= PLANE_MAP_POINTS_MAX);
	for (int i = 0; i < mount->cross_count; i++) {
		const struct pen_cross *cross = &mount->cross[i];
		seen[i] = px(cross->seen_x, cross->seen_y);
		meant[i] = px(cross->meant_x, cross->meant_y);
	}
	return plane_map_find(seen, meant, mount->cross_count, map, rms_px, worst_px, fault);
}

struct plane_map pen_mount_map(const struct pen_mount *mount, int width_px, int height_px,
			       bool calibrated)
{
	struct plane_map calibration = plane_map_identity, back;
	float rms_px, worst_px;
	char fault[200];
	if (calibrated)
		pen_mount_calibrate(mount, &calibration, &rms_px, &worst_px, fault);
	if (mount->panel_width == 0)
		return calibration;
	struct plane_map shown = plane_map_fit(
		(struct v2){(float)width_px, (float)height_px}, mount->rotation,
		(struct v2){(float)mount->panel_width, (float)mount->panel_height});
	plane_map_invert(&shown, &back);
	return plane_map_join(&calibration, &back);
}
