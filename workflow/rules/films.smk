# Films: every test trajectory, true and forecast, and every scene. `all` has a contact sheet instead.


rule film_forecast:
    input:
        truth="results/dataset/{split}.parquet",
        forecast=forecasts_of("{split}"),
    output:
        "results/films/{split}/B{B}_k{k}.webp",
    log:
        "results/logs/film_forecast/{split}_B{B}_k{k}.log",
    group:
        "films"
    params:
        code=code_of("film_forecast"),
        settings=lambda wildcards: as_json({"B": wildcards.B, "angle_index": wildcards.k}),
    shell:
        "sedfiber film_forecast --truth {input.truth} --forecast {input.forecast}"
        " --settings {params.settings:q} -o {output} > {log} 2>&1"


rule film_scene:
    input:
        "results/scenes/{scene}.parquet",
    output:
        "results/films/scenes/{scene}.webp",
    log:
        "results/logs/film_scene/{scene}.log",
    group:
        "films"
    params:
        code=code_of("film_scene"),
        settings=lambda wildcards: as_json({"title": wildcards.scene.replace("_", " ")}),
    shell:
        "sedfiber film_scene {input} --settings {params.settings:q} -o {output} > {log} 2>&1"


rule films:
    input:
        [
            f"results/films/{split}/B{B}_k{k}.webp"
            for split in TEST_SETS
            for B, k in STUDY.runs(split)
        ],
        expand("results/films/scenes/{scene}.webp", scene=SCENES),
