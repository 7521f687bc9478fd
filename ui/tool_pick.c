/* What lies under the pen. Reaches are millimetres on the real screen, so that a small screen of
 * many pixels is not harder to hit. */
#include "tool.h"

static const float mark_reach_mm = 3.0f, badge_reach_mm = 5.0f, pin_reach_mm = 4.0f;
static const float corner_reach_mm = 4.5f;
static const float edge_tie_mm = 1.5f; /* nearer than this to each other: the upper piece */
static const float hidden_m = 0.03f;   /* a pin so far behind the body's surface is hidden */
static const float sunk_m = 0.004f;    /* cloth may sink so deep between its vertices */

bool pick_edge(const struct ui *ui, const struct session *session, struct v2 position_px,
	       float reach_mm, struct edge_ref *edge, float *fraction)
{
	const struct pattern *pattern = &session->document.pattern;
	struct v2 sheet_mm = view_sheet_mm(&ui->view, position_px);
	float reach = tool_sheet_mm(ui, reach_mm), tie = tool_sheet_mm(ui, edge_tie_mm);
	float best = reach;
	int best_piece = -1;
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &pattern->piece[p];
		int at;
		float along;
		if (!piece->used)
			continue;
		float distance = piece_nearest_edge(piece, piece_from_sheet(piece, sheet_mm), &at,
						    &along);
		bool above = best_piece >= 0 && piece->layer > pattern->piece[best_piece].layer;
		float margin = best_piece < 0 ? 0.0f : above ? tie : -tie;
		if (distance > reach || distance > best + margin)
			continue;
		best = distance;
		best_piece = p;
		*edge = (struct edge_ref){p, at};
		*fraction = along;
	}
	return best_piece >= 0;
}

int pick_corner(const struct ui *ui, const struct piece *piece, struct v2 position_px)
{
	float best = tool_px(ui, corner_reach_mm);
	int corner = -1;
	for (int i = 0, k = 0; i < piece->point_count; i++) {
		struct v2 at = view_sheet_px(&ui->view, piece_to_sheet(piece, piece->point_mm[i]));
		float distance = v2_distance(at, position_px);
		if (piece->corner[i] && distance < best) {
			best = distance;
			corner = k;
		}
		k += piece->corner[i];
	}
	return corner;
}

int seam_of_edge(const struct pattern *pattern, struct edge_ref edge)
{
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (seam->used && ((seam->a.piece == edge.piece && seam->a.edge == edge.edge) ||
				   (seam->b.piece == edge.piece && seam->b.edge == edge.edge)))
			return s;
	}
	return -1;
}

struct v2 seam_badge_px(const struct ui *ui, const struct pattern *pattern, const struct seam *seam,
			int side)
{
	const struct edge_ref *ref = side == 0 ? &seam->a : &seam->b;
	const struct piece *piece = &pattern->piece[ref->piece];
	struct v2 at[3];
	for (int i = 0; i < 3; i++) {
		struct v2 local = piece_edge_point(piece, ref->edge, 0.47f + 0.03f * (float)i);
		at[i] = view_sheet_px(&ui->view, piece_to_sheet(piece, local));
	}
	/* Counter-clockwise on the sheet (y up) has the outside to the right; y is down here. */
	struct v2 along = v2_normalize(v2_sub(at[2], at[0]));
	struct v2 out = {-along.y, along.x};
	float offset = (float)layout_px(&ui->layout, 24) * (piece->inside_up ? -1.0f : 1.0f);
	return v2_add(at[1], v2_scale(out, offset));
}

int pick_seam(const struct ui *ui, const struct session *session, struct v2 position_px)
{
	const struct pattern *pattern = &session->document.pattern;
	float best = tool_px(ui, badge_reach_mm), fraction;
	int seam = -1;
	for (int s = 0; s < SEAMS_MAX; s++)
		for (int side = 0; pattern->seam[s].used && side < 2; side++) {
			struct v2 badge = seam_badge_px(ui, pattern, &pattern->seam[s], side);
			float distance = v2_distance(badge, position_px);
			if (distance < best) {
				best = distance;
				seam = s;
			}
		}
	struct edge_ref edge;
	if (seam < 0 && pick_edge(ui, session, position_px, badge_reach_mm, &edge, &fraction))
		seam = seam_of_edge(pattern, edge);
	return seam;
}

/* Nearness of a line with its number at its start, as one figure: 0 at the line, 1 out of reach. */
static float mark_nearness(const struct ui *ui, const struct v2 *line, int count, struct v2 pen)
{
	float line_share = stroke_distance(line, count, pen) / tool_px(ui, mark_reach_mm);
	float number_share = v2_distance(line[0], pen) / tool_px(ui, badge_reach_mm);
	return float_min(line_share, number_share);
}

int pick_cloth_mark(const struct ui *ui, const struct session *session, struct v2 position_px)
{
	float best = 1.0f;
	int number = 0;
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &session->document.marks.cloth[m];
		struct v2 line[MARK_POINTS_MAX];
		if (!mark->used || !piece_used(session, mark->piece))
			continue;
		const struct piece *piece = &session->document.pattern.piece[mark->piece];
		for (int i = 0; i < mark->point_count; i++)
			line[i] = view_sheet_px(&ui->view,
						piece_to_sheet(piece, mark->point_mm[i]));
		float nearness = mark_nearness(ui, line, mark->point_count, position_px);
		if (nearness < best) {
			best = nearness;
			number = mark->number;
		}
	}
	return number;
}

int pick_body_mark(const struct ui *ui, const struct session *session, struct v2 position_px)
{
	float best = 1.0f;
	int number = 0;
	struct v3 eye = view_eye(&ui->view);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct body_mark *mark = &session->document.marks.body[m];
		struct v2 line[MARK_POINTS_MAX];
		int seen = 0;
		for (int i = 0; mark->used && i < mark->point_count; i++) {
			float depth;
			struct v3 to_eye = v3_sub(eye, mark->point_m[i]);
			if (v3_dot(mark->normal[i], to_eye) > 0.0f &&
			    view_project(&ui->view, mark->point_m[i], &line[seen], &depth))
				seen++;
		}
		float nearness = seen > 0 ? mark_nearness(ui, line, seen, position_px) : 1.0f;
		if (nearness < best) {
			best = nearness;
			number = mark->number;
		}
	}
	return number;
}

static bool hidden(const struct ui *ui, const struct session *session, struct v3 point_m)
{
	struct body_hit hit;
	struct v3 eye = view_eye(&ui->view);
	struct v3 way = v3_sub(point_m, eye);
	float distance_m = v3_length(way);
	return body_ray(&session->body, eye, v3_normalize(way), &hit) &&
	       hit.distance_m < distance_m - hidden_m;
}

int pick_pin(const struct ui *ui, const struct session *session, struct v2 position_px)
{
	float best = tool_px(ui, pin_reach_mm), depth;
	bool on_sheet = rect_holds(ui->layout.right, position_px);
	int found = -1;
	for (int p = 0; p < PINS_MAX; p++) {
		const struct pin *pin = &session->document.pin[p];
		struct v2 at;
		if (!pin->used || !piece_used(session, pin->piece))
			continue;
		const struct piece *piece = &session->document.pattern.piece[pin->piece];
		if (on_sheet)
			at = view_sheet_px(&ui->view, piece_to_sheet(piece, pin->point_mm));
		else if (!view_project(&ui->view, pin->held_m, &at, &depth) ||
			 hidden(ui, session, pin->held_m))
			continue;
		float distance = v2_distance(at, position_px);
		if (distance < best) {
			best = distance;
			found = p;
		}
	}
	return found;
}

/* A ray that runs exactly between two triangles may slip through; one a third of a pixel beside it
 * does not. */
static const struct v2 beside_px = {0.31f, 0.17f};

static bool ray_meets(const struct view *view, const struct body *body, struct v2 position_px,
		      bool back, struct body_hit *hit)
{
	struct v3 origin, direction;
	view_ray(view, position_px, &origin, &direction);
	return back ? body_ray_back(body, origin, direction, hit)
		    : body_ray(body, origin, direction, hit);
}

bool pick_body_side(const struct ui *ui, const struct session *session, struct v2 position_px,
		    bool back, struct body_hit *hit)
{
	const struct body *body = &session->body;
	return body->triangle_count > 0 &&
	       (ray_meets(&ui->view, body, position_px, back, hit) ||
		ray_meets(&ui->view, body, v2_add(position_px, beside_px), back, hit));
}

bool pick_body(const struct ui *ui, const struct session *session, struct v2 position_px,
	       struct body_hit *hit)
{
	return pick_body_side(ui, session, position_px, false, hit);
}

/* The ray's triangle of cloth, if the body does not lie before it. */
static int worn_triangle(const struct ui *ui, const struct session *session, struct v2 position_px,
			 float weight[3], struct v3 *point_m)
{
	struct v3 origin, direction;
	struct body_hit body;
	float distance_m = 0.0f;
	view_ray(&ui->view, position_px, &origin, &direction);
	int triangle = cloth_ray(&session->cloth, origin, direction, &distance_m, weight);
	if (triangle < 0 ||
	    (pick_body(ui, session, position_px, &body) && body.distance_m < distance_m - sunk_m))
		return -1;
	*point_m = v3_mad(origin, direction, distance_m);
	return triangle;
}

bool pick_worn(const struct ui *ui, const struct session *session, struct v2 position_px,
	       struct worn_hit *hit)
{
	if (!session->cloth.worn || session->job != JOB_NONE)
		return false;
	hit->triangle = worn_triangle(ui, session, position_px, hit->weight, &hit->point_m);
	if (hit->triangle < 0) {
		struct v2 beside = v2_add(position_px, beside_px);
		hit->triangle = worn_triangle(ui, session, beside, hit->weight, &hit->point_m);
	}
	if (hit->triangle < 0)
		return false;
	const struct garment *garment = &session->garment;
	const int *v = garment->triangle[hit->triangle].v;
	hit->piece = garment->piece[v[0]];
	hit->local_mm = (struct v2){0.0f, 0.0f};
	for (int k = 0; k < 3; k++)
		hit->local_mm = v2_add(hit->local_mm,
				       v2_scale(garment->rest_m[v[k]], 1000.0f * hit->weight[k]));
	return true;
}

void piece_bounds(const struct piece *piece, struct v2 *low_mm, struct v2 *high_mm)
{
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 p = piece_to_sheet(piece, piece->point_mm[i]);
		*low_mm = i == 0 ? p
				 : (struct v2){float_min(low_mm->x, p.x),
					       float_min(low_mm->y, p.y)};
		*high_mm = i == 0 ? p
				  : (struct v2){float_max(high_mm->x, p.x),
						float_max(high_mm->y, p.y)};
	}
}
