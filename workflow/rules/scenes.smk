# Example scenes, and any other file in scenes/: each is run and drawn.


rule simulate_scene:
    input:
        lambda wildcards: scene_files(wildcards.scene),
    output:
        "results/scenes/{scene}.parquet",
    log:
        "results/logs/simulate_scene/{scene}.log",
    params:
        code=code_of("simulate"),
        file=lambda wildcards: scene_files(wildcards.scene)[0],
    shell:
        "sedfiber simulate {params.file} -o {output} > {log} 2>&1"


use rule tabulate_audit as tabulate_scene_audit with:
    input:
        expand("results/scenes/{scene}.parquet", scene=SCENES),
    output:
        "results/tables/scene_audit.csv",
    log:
        "results/logs/tabulate_scene_audit.log",


rule scenes:
    input:
        expand("results/figures/scenes/{scene}.png", scene=SCENES),
        rules.tabulate_scene_audit.output,


rule compare_third_dimension:
    output:
        table="results/tables/third_dimension.csv",
        growth="results/tables/third_dimension_growth.csv",
    log:
        "results/logs/compare_third_dimension.log",
    params:
        code=code_of("compare_third_dimension"),
        settings=as_json(STUDY.fiber | config["third_dimension"]),
    shell:
        "sedfiber compare_third_dimension --settings {params.settings:q}"
        " -o {output.table} --growth {output.growth} > {log} 2>&1"


rule third_dimension:
    input:
        figures_of("third_dimension"),


rule measure_effects:
    output:
        "results/tables/effects.csv",
    log:
        "results/logs/measure_effects.log",
    params:
        code=code_of("measure_effects"),
        settings=as_json(STUDY.fiber | config["effects"]),
    shell:
        "sedfiber measure_effects --settings {params.settings:q} -o {output} > {log} 2>&1"


rule benchmark_parts:
    output:
        "results/tables/parts_against_fused_kernel.csv",
    log:
        "results/logs/benchmark_parts.log",
    params:
        code=code_of("benchmark_parts"),
    shell:
        "sedfiber benchmark_parts -o {output} > {log} 2>&1"


rule effects:
    input:
        figures_of("effects"),
        rules.benchmark_parts.output,
