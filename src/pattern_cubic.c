#include "pattern_cubic.h"

void cubic_fit_begin(struct cubic_fit *fit, struct v2 a, struct v2 b)
{
	*fit = (struct cubic_fit){.a = a, .b = b};
}

void cubic_fit_add(struct cubic_fit *fit, float u, struct v2 at)
{
	float v = 1.0f - u, p = 3.0f * u * v * v, q = 3.0f * u * u * v;
	struct v2 rest = v2_sub(at, fit->a);
	rest = v2_sub(rest, v2_scale(v2_sub(fit->b, fit->a), u * u * u + q));
	fit->pp += p * p;
	fit->pq += p * q;
	fit->qq += q * q;
	fit->p = v2_add(fit->p, v2_scale(rest, p));
	fit->q = v2_add(fit->q, v2_scale(rest, q));
}

void cubic_fit_end(const struct cubic_fit *fit, struct v2 handle[2])
{
	float pp = fit->pp, pq = fit->pq, qq = fit->qq, determinant = pp * qq - pq * pq;
	struct v2 third = v2_scale(v2_sub(fit->b, fit->a), 1.0f / 3.0f);
	handle[0] = third;
	handle[1] = v2_scale(third, -1.0f);
	if (!(determinant > 1e-3f * pp * qq))
		return;
	handle[0] = v2_scale(v2_sub(v2_scale(fit->p, qq), v2_scale(fit->q, pq)),
			     1.0f / determinant);
	handle[1] = v2_scale(v2_sub(v2_scale(fit->q, pp), v2_scale(fit->p, pq)),
			     1.0f / determinant);
}

struct v2 cubic_at(struct v2 a, struct v2 b, const struct v2 handle[2], float u)
{
	struct v2 c = v2_add(a, handle[0]), d = v2_add(b, handle[1]);
	struct v2 ac = v2_lerp(a, c, u), cd = v2_lerp(c, d, u), db = v2_lerp(d, b, u);
	return v2_lerp(v2_lerp(ac, cd, u), v2_lerp(cd, db, u), u);
}
