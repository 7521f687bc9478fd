#include "text.h"

#define EASED_SHARE 0.03f /* of a seam's length: less is not worth a word */

const struct phrase text_target[TARGET_COUNT] = {
	[TARGET_STEP_DRAW] = {"描く", "Draw"},
	[TARGET_STEP_SEW] = {"縫う", "Sew"},
	[TARGET_STEP_MARK] = {"印", "Mark"},
	[TARGET_STEP_DRESS] = {"着せる", "Dress"},
	[TARGET_STEP_ADJUST] = {"整える", "Adjust"},
	[TARGET_UNDO] = {"元に戻す", "Undo"},
	[TARGET_REDO] = {"やり直す", "Redo"},
	[TARGET_LANGUAGE] = {"日本語", "English"},
	[TARGET_HAND] = {"利き手", "Hand"},
	[TARGET_CLEAR] = {"はじめから", "Hold: restart"},
	[TARGET_VIEW_FRONT] = {"前", "Front"},
	[TARGET_VIEW_SIDE] = {"横", "Side"},
	[TARGET_VIEW_BACK] = {"後", "Back"},
	[TARGET_COPY] = {"複製", "Copy"},
	[TARGET_TURN_OVER] = {"裏返す", "Turn over"},
	[TARGET_MIRROR] = {"左右反転", "Mirror"},
	[TARGET_DELETE] = {"消す", "Delete"},
	[TARGET_SWAP] = {"向き", "Swap"},
	[TARGET_LASER] = {"前と後", "Laser: both"},
	[TARGET_ERASE] = {"消す", "Erase"},
	[TARGET_WRAP] = {"着せる", "WRAP"},
	[TARGET_PIN] = {"ピン", "PIN"},
	[TARGET_RELAX] = {"なじませる", "RELAX"},
	[TARGET_TOOL_PENCIL] = {"えんぴつ", "Pencil"},
	[TARGET_TOOL_POINTS] = {"点と線", "Points"},
	[TARGET_TOOL_BOX] = {"四角", "Box"},
	[TARGET_TOOL_ROUND] = {"丸", "Round"},
	[TARGET_FOLD] = {"左右同じ", "Symmetric"},
	[TARGET_EVEN] = {"同じ長さ", "Equal"},
	[TARGET_FINISH] = {"できあがり", "Take it home"},
};

const struct phrase text_phrase[TEXT_COUNT] = {
	[TEXT_NONE] = {"", ""},
	[TEXT_HINT_DRAW] = {"布の形を、ひと筆で描こう", "Draw the shape of a piece in one line"},
	[TEXT_HINT_DRAW_SELECTED] = {"次の布を描くか、この布を複製しよう",
				     "Draw the next piece, or copy this one"},
	[TEXT_HINT_GRIPS] = {"枠をつまんで、大きさと向きを変えよう",
			     "Pull the frame to resize or turn the piece"},
	[TEXT_HINT_AXIS] = {"布を横切る線を引くと、折り目が変わります",
			    "A line across the piece moves its fold"},
	[TEXT_HINT_POINTS] = {"点や線を引こう。線に軽く触れると、点がふえます",
			      "Pull points and lines; tap a line for a new point"},
	[TEXT_HINT_POINTS_NONE] = {"直したい布に触れよう", "Touch the piece you want to change"},
	[TEXT_HINT_CORNER] = {"点を引こう。「消す」で点がなくなります",
			      "Pull the point, or delete it"},
	[TEXT_HINT_BOX] = {"紙の上で、角から角へ引こう", "Draw from corner to corner"},
	[TEXT_HINT_SEW] = {"縫い合わせる端から端へ、線を引こう",
			   "Draw a line from one edge to the edge it joins"},
	[TEXT_HINT_SEW_SELECTED] = {"同じ文字どうしが縫われます",
				    "Edges with the same letter are sewn"},
	[TEXT_HINT_SEW_EASED] = {"長いほうは、縫い縮めます",
				 "The longer edge is gathered to fit the other"},
	[TEXT_HINT_SEW_EVEN] = {"片方を直すと、もう片方も同じ長さになります",
				"Change one edge, and the other keeps its length"},
	[TEXT_HINT_MARK_CLOTH] = {"まず布の上に、線を引こう", "First draw a line on the cloth"},
	[TEXT_HINT_MARK_BODY] = {"体の同じところに、線を引こう",
				 "Now draw its partner on the body"},
	[TEXT_HINT_MARK_PARTNER] = {"布の同じところに、線を引こう",
				    "Now draw its partner on the cloth"},
	[TEXT_HINT_MARK_PAIR] = {"線が合ったら「着せる」を押そう",
				 "When the lines match, press WRAP"},
	[TEXT_HINT_ERASE] = {"消したい線や番号に触れよう", "Touch a line or number to erase it"},
	[TEXT_HINT_LASER] = {"ひとつの線で、前と後に印がつきます",
			     "One line marks the front and the back"},
	[TEXT_HINT_DRESS] = {"印をつけて「着せる」を押そう", "Make marks, then press WRAP"},
	[TEXT_HINT_DRESSING] = {"着せています…", "Dressing..."},
	[TEXT_HINT_WORN] = {"服に触れて、動かしてみよう", "Touch the garment and pull it"},
	[TEXT_HINT_ADJUST] = {"服をつまんで、体に沿って動かそう",
			      "Drag the garment along the body"},
	[TEXT_HINT_PIN] = {"留めたいところを軽く触れよう",
			   "Tap the cloth where a pin should hold it"},
	[TEXT_HINT_RELAX] = {"布がなじんでいきます", "The cloth settles while you hold"},
	[TEXT_AGAIN] = {"うまくいきませんでした。もう一度", "That did not work. Please try again"},
	[TEXT_CROSSES] = {"線が交わっています。もう一度描こう",
			  "The line crosses itself. Draw again"},
	[TEXT_SMALL] = {"小さすぎます。もっと大きく描こう", "Too small. Draw it larger"},
	[TEXT_ENDS_APART] = {"線の始めと終わりを近づけよう",
			     "Bring both ends of the line together"},
	[TEXT_OVERSKETCH] = {"布のふちから、ふちへ描こう",
			     "Begin and end the line on the piece's edge"},
	[TEXT_POINT_NEAR] = {"ここにはもう点があります", "There is a point already"},
	[TEXT_LAST_POINTS] = {"点はこれ以上、減らせません", "These points are needed"},
	[TEXT_NO_FOLD] = {"この形は、左右同じにできません", "This shape cannot be made symmetric"},
	[TEXT_NO_PIECE] = {"先に布を選ぼう", "Choose a piece first"},
	[TEXT_NO_SEAM] = {"先に縫い目を選ぼう", "Choose a seam first"},
	[TEXT_SELF_SEAM] = {"別の端まで線を引こう", "Draw on to a different edge"},
	[TEXT_EDGE_SEWN] = {"その端はもう縫ってあります", "That edge is sewn already"},
	[TEXT_SEW_ENDS] = {"布の端から端へ、線を引こう", "Draw from one edge to another"},
	[TEXT_OFF_CLOTH] = {"布の上に線を引こう", "Draw the line on a piece of cloth"},
	[TEXT_OFF_BODY] = {"体の上に線を引こう", "Draw the line on the body"},
	[TEXT_NO_PAIR] = {"先に、布と体に同じ番号の線を引こう",
			  "First draw a line on the cloth and its partner on the body"},
	[TEXT_NOTHING] = {"先に、布を描こう", "First draw a piece of cloth"},
	[TEXT_NOT_WORN] = {"先に「着せる」を押そう", "Press WRAP first"},
	[TEXT_FULL] = {"もういっぱいです。何かを消そう", "It is full. Remove something first"},
	[TEXT_MESH] = {"この形は着せられません。布を描き直そう",
		       "This shape cannot be worn. Redraw the piece"},
	[TEXT_UNREACHED] = {"印も縫い目もない布が残っています",
			    "Some cloth has neither a mark nor a seam"},
	[TEXT_DISAGREE] = {"印が縫い目を引き離しています", "The marks pull the seams apart"},
	[TEXT_LENGTHS] = {"二本の線の長さが、大きく違います",
			  "These two lines differ much in length"},
	[TEXT_NO_PARTNER] = {"この線の相手が、体にありません",
			     "This line has no partner on the body"},
	[TEXT_DIRECTIONS] = {"線の向きが逆です。反対の端から描き直そう",
			     "One line runs the other way. Redraw it"},
	[TEXT_NOT_SEWN] = {"縫い目が閉じません。印を描き直そう",
			   "The seams stay open. Redraw the marks"},
	[TEXT_HEAD_OUTSIDE] = {"布が頭にかぶさっています。印を首から描こう",
			       "It covers the head. Begin the mark at the neck"},
	[TEXT_LIMB_OUTSIDE] = {"腕や足が通っていません。印を描き直そう",
			       "An arm or leg is outside. Redraw its mark"},
	[TEXT_NOT_REACHED] = {"じゃまがあって、印まで届きません",
			      "Something keeps it from the new mark"},
	[TEXT_MARK_IGNORED] = {"この印は使わず、縫い目に合わせました",
			       "This mark was left out; the seams decided"},
	[TEXT_SWAPPED] = {"印の左右を入れかえました", "Left and right marks were swapped"},
	[TEXT_LET_OUT] = {"体より小さいので、布を広げました",
			  "Too narrow for the body, so it was let out"},
	[TEXT_GATHERED] = {"長いところは、寄せて着せました",
			   "Too long there, so it is worn gathered"},
	[TEXT_INSIDE_UP] = {"うら", "inside up"},
	[TEXT_CLOTH] = {"布", "Piece"},
	[TEXT_STRAIN] = {"布の伸び", "Stretch of the cloth"},
	[TEXT_TITLE] = {"着付け", "kitsuke"},
};

/* The first entry whose words occur in the reason decides, so that a sentence may be polished
 * without the face going silent. */
static const struct {
	const char *words;
	enum text text;
} refusal[] = {
	{"cross", TEXT_CROSSES},
	{"clockwise", TEXT_CROSSES}, /* an eight whose larger half runs that way */
	{"square centimetre", TEXT_SMALL},
	{"small", TEXT_SMALL},
	{"short", TEXT_SMALL},
	{"line is open", TEXT_ENDS_APART},
	{"corner already", TEXT_POINT_NEAR},
	{"two corners", TEXT_LAST_POINTS},
	{"axis", TEXT_NO_FOLD},
	{"begin", TEXT_OVERSKETCH},
	{"sewn already", TEXT_EDGE_SEWN},
	{"sewn to itself", TEXT_SELF_SEAM},
	{"partner on the body", TEXT_NO_PAIR},
	{"press WRAP", TEXT_NOT_WORN},
	{"full", TEXT_FULL},
	{"as many", TEXT_FULL},
	{"too many", TEXT_FULL},
	{"no such piece", TEXT_NO_PIECE},
	{"no such seam", TEXT_NO_SEAM},
	{"no cloth", TEXT_OFF_CLOTH},
	{"no body", TEXT_OFF_BODY},
	{"seam leads", TEXT_MESH},
	{"sewn twice", TEXT_EDGE_SEWN},
	{"mesh", TEXT_MESH},
};

static bool holds_words(const char *text, const char *words)
{
	size_t size = strlen(words);
	for (; *text; text++)
		if (strncmp(text, words, size) == 0)
			return true;
	return false;
}

enum text text_refusal(const char *reason)
{
	for (int i = 0; i < COUNT_OF(refusal); i++)
		if (holds_words(reason, refusal[i].words))
			return refusal[i].text;
	return TEXT_AGAIN;
}

static enum text hint_mark(const struct ui *ui, const struct session *session)
{
	int cloth = 0, body = 0;
	for (int m = 0; m < MARKS_MAX; m++) {
		cloth += session->document.marks.cloth[m].used;
		body += session->document.marks.body[m].used;
	}
	if (ui->erase)
		return TEXT_HINT_ERASE;
	if (ui->laser)
		return TEXT_HINT_LASER;
	if (cloth > body)
		return TEXT_HINT_MARK_BODY;
	if (body > cloth)
		return TEXT_HINT_MARK_PARTNER;
	return cloth > 0 && cloth == body ? TEXT_HINT_MARK_PAIR : TEXT_HINT_MARK_CLOTH;
}

static enum text hint_sew(const struct ui *ui, const struct pattern *pattern)
{
	if (ui->seam < 0 || !pattern->seam[ui->seam].used)
		return TEXT_HINT_SEW;
	const struct seam *seam = &pattern->seam[ui->seam];
	float a = piece_edge_length_mm(&pattern->piece[seam->a.piece], seam->a.edge);
	float b = piece_edge_length_mm(&pattern->piece[seam->b.piece], seam->b.edge);
	if (seam->even)
		return TEXT_HINT_SEW_EVEN;
	return float_abs(a - b) > EASED_SHARE * float_max(a, b) ? TEXT_HINT_SEW_EASED
								: TEXT_HINT_SEW_SELECTED;
}

static enum text hint_draw(const struct ui *ui, const struct session *session)
{
	if (ui->drawing == DRAW_BOX || ui->drawing == DRAW_ROUND)
		return TEXT_HINT_BOX;
	if (ui->drawing == DRAW_POINTS && ui->piece < 0)
		return TEXT_HINT_POINTS_NONE;
	if (ui->drawing == DRAW_POINTS)
		return ui->corner >= 0 ? TEXT_HINT_CORNER : TEXT_HINT_POINTS;
	if (ui->shaping.shows || ui->hover_grip != GRIP_NONE)
		return TEXT_HINT_GRIPS;
	if (ui->piece >= 0 && session->document.pattern.piece[ui->piece].symmetric)
		return TEXT_HINT_AXIS;
	return ui->piece >= 0 ? TEXT_HINT_DRAW_SELECTED : TEXT_HINT_DRAW;
}

/* The gravest of what the wrap found, in this order. */
static enum text hint_diagnosis(const struct diagnoses *diagnoses, int mark[2])
{
	static const struct {
		const char *kind;
		enum text text;
	} known[] = {
		{"piece-unreached", TEXT_UNREACHED},
		{"marks-disagree", TEXT_DISAGREE},
		{"directions-differ", TEXT_DIRECTIONS},
		{"head-outside", TEXT_HEAD_OUTSIDE},
		{"limb-outside", TEXT_LIMB_OUTSIDE},
		{"mark-not-reached", TEXT_NOT_REACHED},
		{"not-sewn", TEXT_NOT_SEWN},
		{"lengths-differ", TEXT_LENGTHS},
		{"no-partner", TEXT_NO_PARTNER},
		{"mark-ignored", TEXT_MARK_IGNORED},
		{"marks-swapped", TEXT_SWAPPED},
		{"let_out", TEXT_LET_OUT},
		{"gathered", TEXT_GATHERED},
	};
	for (int k = 0; k < COUNT_OF(known); k++)
		for (int d = 0; d < diagnoses->count; d++) {
			const struct diagnosis *found = &diagnoses->item[d];
			if (strcmp(found->kind, known[k].kind) != 0)
				continue;
			mark[0] = found->mark[0];
			mark[1] = found->mark[1];
			return known[k].text;
		}
	return TEXT_HINT_WORN;
}

enum text text_hint(const struct ui *ui, const struct session *session, int mark[2])
{
	mark[0] = mark[1] = 0;
	if (session->job != JOB_NONE)
		return TEXT_HINT_DRESSING;
	if (session->relaxing)
		return TEXT_HINT_RELAX;
	switch (ui->step) {
	case STEP_DRAW:
		return hint_draw(ui, session);
	case STEP_SEW:
		return hint_sew(ui, &session->document.pattern);
	case STEP_MARK:
		return hint_mark(ui, session);
	case STEP_DRESS:
		return session->cloth.worn ? hint_diagnosis(&session->wrap.diagnoses, mark)
					   : TEXT_HINT_DRESS;
	case STEP_ADJUST:
		if (!session->cloth.worn)
			return TEXT_HINT_DRESS;
		return ui->pin_mode ? TEXT_HINT_PIN : TEXT_HINT_ADJUST;
	case STEP_COUNT:
		break;
	}
	return TEXT_NONE;
}
